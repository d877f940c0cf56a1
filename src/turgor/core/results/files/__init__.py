"""Files: states and modes written for ParaView."""
