"""Tables and polynomials of what an actuator does over the range of its inputs."""
