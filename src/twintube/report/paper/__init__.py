"""`twintube paper figures` shows these: the figures of the paper made anew, and the verdicts on its statements."""
