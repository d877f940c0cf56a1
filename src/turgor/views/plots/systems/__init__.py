"""Plots of actuators with what drives them."""
