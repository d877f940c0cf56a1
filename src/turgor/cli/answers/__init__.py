"""What commands answer to programs: results, and the JSON document that holds them."""
