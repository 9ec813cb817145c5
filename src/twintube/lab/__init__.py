"""Test data independent of the model: a damper with other physics, and datasets with a hidden effect or fault."""
