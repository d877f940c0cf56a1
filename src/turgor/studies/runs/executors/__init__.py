"""Where runs are computed: in this process, in worker processes, and elsewhere."""
