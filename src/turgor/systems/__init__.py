"""Systems: actuators with what drives them."""
