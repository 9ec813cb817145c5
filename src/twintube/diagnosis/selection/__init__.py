"""Which causes the records ask for, and what explains them as well."""
