"""Store: files of models, solutions and runs, without pickle."""
