"""Shape-memory alloys: the one-dimensional law of a wire, its phases, and published constants."""
