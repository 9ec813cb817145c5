"""The FMI side of twintube: the pythonfmu slave, its model description and its documentation page."""
