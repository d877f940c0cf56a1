"""Tables: what each table of a job file may contain, and the value that is made from it."""
