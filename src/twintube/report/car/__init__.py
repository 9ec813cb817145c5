"""`twintube car` and `twintube car-sensitivity` show these: the page of the whole car, that of its assumed values."""
