"""Files that describe a network: TOML, in which every quantity has its unit."""
