"""Pictures of studies: curves of each level, effects with mesh errors, maps of two factors, many factors at once."""
