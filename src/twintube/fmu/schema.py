"""Model descriptions against the schemas of FMI, which travel in the package."""

from functools import cache

from lxml import etree

from twintube.fmu.platforms import Fmi
from twintube.native.units import HEADERS


class SchemaError(RuntimeError):
    """A model description is not what its standard wants; the message has the line."""


@cache
def schema(fmi: Fmi) -> etree.XMLSchema:
    """The schema of a version of FMI."""
    return etree.XMLSchema(etree.parse(str(HEADERS / "schema" / f"fmi{fmi}" / f"fmi{fmi}ModelDescription.xsd")))


def valid(description: bytes, fmi: Fmi) -> None:
    """Raise SchemaError unless a model description is valid."""
    against = schema(fmi)
    if not against.validate(etree.fromstring(description)):
        raise SchemaError(f"modelDescription.xml is not valid: {against.error_log.last_error}")
