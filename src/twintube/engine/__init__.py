"""The compiled kernel: records and swarms of them at machine speed."""
