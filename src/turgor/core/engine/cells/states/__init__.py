"""States of bodies that loads set: where they are free of stress, how stiff they are, and what hardens in them."""
