"""`twintube diagnose` shows these: its answer in the terminal and report.html."""
