"""Start-up: where compiled kernels are cached, and the process that compiles in the background (docs/startup.md)."""
