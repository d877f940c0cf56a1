"""Studies: many runs of the same question, in processes of their own, saved on disk as they end."""
