"""Files of FEBio (.feb) as the keywords of a deck."""
