"""Parts of .inp files: materials and reference points."""
