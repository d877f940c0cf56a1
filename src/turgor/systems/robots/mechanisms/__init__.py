"""Mechanisms: arms of several actuators, and grippers around an object."""
