"""A quarter car on a class D road with the damper as FMU, driven by fmpy, from intact to 30 % oil."""

from twintube.cli.base import standalone
from twintube.cli.demo import FORMER, demo

if __name__ == "__main__":
    standalone(demo, FORMER)()
