"""Reports: the paper's figures reproduced, as one HTML page with pictures and JSON."""

from twintube.report.reproduce import Report, reproduce

__all__ = ["Report", "reproduce"]
