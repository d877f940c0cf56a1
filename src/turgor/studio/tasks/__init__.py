"""Tasks of the worker: what needs the engine, the CAD kernel or minutes, in a process of its own."""
