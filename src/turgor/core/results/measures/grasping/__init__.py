"""Grasping: contacts of an object, how near they are to slipping, and whether they close it in by force."""
