"""Children: processes of their own that solve runs and studies; they outlive the server, which finds them again."""
