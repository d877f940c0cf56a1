"""Chains of rigid links of an actuator, and their files for MuJoCo and URDF."""
