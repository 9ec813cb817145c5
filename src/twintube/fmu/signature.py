"""The signature of a Mach-O library that nobody signed: digests of its pages, which a loader of macOS on ARM compares.

A library whose bytes were changed is signed anew. Layout: Apple's `cs_blobs.h`; numbers of the signature are big-endian.
"""

import hashlib
import struct
from dataclasses import dataclass

MACH_O_64 = 0xFEEDFACF
HEADER = 32  # bytes before the load commands
CODE_SIGNATURE = 0x1D  # a load command
SIGNATURE, DIRECTORY = 0xFADE0CC0, 0xFADE0C02  # all blobs; that of the digests
SHA256 = 2


class SignatureError(ValueError):
    """The signature is none that can be written anew: not of SHA-256, or cut."""


@dataclass(frozen=True)
class Directory:
    """Where the digests of a library's pages are, and of how many bytes they are."""

    digests: int  # place of the first
    count: int
    size: int  # of a digest
    page: int
    signed: int  # bytes from the beginning of the file

    def page_at(self, library: bytes, number: int) -> bytes:
        """The bytes of a page; the last ends where the signed bytes do."""
        return library[number * self.page : min((number + 1) * self.page, self.signed)]

    def stored(self, library: bytes) -> list[bytes]:
        """The digests in the file."""
        return [library[self.digests + i * self.size :][: self.size] for i in range(self.count)]

    def computed(self, library: bytes) -> list[bytes]:
        """The digests of the pages as they are."""
        return [hashlib.sha256(self.page_at(library, i)).digest() for i in range(self.count)]


def signature_at(library: bytes) -> int | None:
    """Where the signature begins; None where a library has none."""
    magic, _, _, _, commands = struct.unpack_from("<IIIII", library)
    if magic != MACH_O_64:
        raise SignatureError("this is no Mach-O library of 64 bits")
    at = HEADER
    for _ in range(commands):
        kind, size = struct.unpack_from("<II", library, at)
        if kind == CODE_SIGNATURE:
            return int(struct.unpack_from("<I", library, at + 8)[0])
        at += size
    return None


def directory(library: bytes) -> Directory | None:
    """The digests of a Mach-O library, None where it is not signed; raises SignatureError."""
    start = signature_at(library)
    if start is None:
        return None
    magic, _, blobs = struct.unpack_from(">III", library, start)
    places = [start + struct.unpack_from(">II", library, start + 12 + 8 * i)[1] for i in range(blobs)]
    found = [at for at in places if struct.unpack_from(">I", library, at) == (DIRECTORY,)]
    if magic != SIGNATURE or len(found) != 1:
        raise SignatureError("the signature has no directory of pages, or several")
    (at,) = found
    digests, _, _, count, signed, size, kind, _, page = struct.unpack_from(">IIIIIBBBB", library, at + 16)
    if kind != SHA256 or count * (1 << page) < signed:
        raise SignatureError(f"digests of kind {kind}, {count} pages for {signed} bytes")
    return Directory(at + digests, count, size, 1 << page, signed)


def signed(library: bytes) -> bytes:
    """A Mach-O library whose digests are those of its pages; unchanged where it has none. Raises SignatureError."""
    found = directory(library)
    if found is None:
        return library
    digests = b"".join(found.computed(library))
    return library[: found.digests] + digests + library[found.digests + len(digests) :]
