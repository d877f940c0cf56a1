"""Decks of Abaqus and CalculiX as jobs: model, loads and steps, with an account of what was understood."""
