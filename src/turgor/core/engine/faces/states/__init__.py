"""States: what states before loading do to sheets."""
