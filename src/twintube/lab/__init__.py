"""Truth that is not our model: a damper of other physics, and datasets in which something is hidden."""
