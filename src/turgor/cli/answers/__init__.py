"""Results of commands for programs, and the JSON document with them."""
