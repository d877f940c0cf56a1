"""Studies: many runs of the same question, in processes of their own, kept on disk as they end."""
