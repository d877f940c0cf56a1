"""How a part lies in its file: turning it so that it lies along x, as measures and models expect."""
