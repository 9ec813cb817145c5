"""A damper with other physics that stands for measurements."""
