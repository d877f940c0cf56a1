"""Study files, optimizations of jobs, and files that are written."""
