"""Air and liquid: networks of supplies, valves, tubes and chambers through time."""
