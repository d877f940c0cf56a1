"""Section 7.4: actuators with many chambers, PneuNets among them."""
