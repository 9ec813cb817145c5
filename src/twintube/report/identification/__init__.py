"""`twintube identify` shows these: report.html with its pictures and the curves to look into."""
