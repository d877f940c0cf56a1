"""Library: records of published materials, their sources and what is doubtful about them."""
