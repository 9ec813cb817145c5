"""`twintube inspect` shows these: its figures in words, and report.html."""
