"""Build the damper as a co-simulation FMU of FMI 2.0 or 3.0: the command `twintube fmu`.

python build_fmu.py SA8
python build_fmu.py SA8 --oil-level 0.6 --gas-lost --output rear_60.fmu
python build_fmu.py my_damper.toml
python build_fmu.py SA8 --as-published
python build_fmu.py SA8 --kind python
python build_fmu.py SA8 --fmi 3
python build_fmu.py --test twintube_SA8.fmu
"""

from twintube.cli.base import standalone
from twintube.cli.fmu import FORMER, fmu

if __name__ == "__main__":
    standalone(fmu, FORMER)()
