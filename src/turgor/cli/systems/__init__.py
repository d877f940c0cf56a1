"""Commands on actuators with what drives them."""
