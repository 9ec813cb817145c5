"""`python -m twintube.stubs` writes the generated types anew."""

from twintube.common.files import write_text
from twintube.stubs import HOOK_TYPES, STUB, hook_types, stub

if __name__ == "__main__":
    write_text(STUB, stub())
    write_text(HOOK_TYPES, hook_types())
