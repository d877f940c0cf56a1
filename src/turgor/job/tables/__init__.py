"""Tables: what each table of a job file may hold, and the value that is made from it."""
