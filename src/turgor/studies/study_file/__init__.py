"""Study files: one TOML format that names a job, what varies in it, and a table for each kind of study."""
