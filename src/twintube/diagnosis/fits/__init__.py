"""The model fitted to the records: candidates, where their fits begin, folds, and the gains on what is held out."""
