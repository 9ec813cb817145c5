"""Studies: a grid over dampers, signals, parameters, oil levels and model variants, computed into one Parquet file."""

from twintube.studies.definition import Signal, Study, StudyError
from twintube.studies.execute import definition_of, run
from twintube.studies.reading import NAMED, load

__all__ = ["NAMED", "Signal", "Study", "StudyError", "definition_of", "load", "run"]
