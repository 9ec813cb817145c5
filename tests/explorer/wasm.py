"""The explorer's module in wasmtime, called as the page calls it."""

import ctypes
from typing import Any

import numpy as np
import wasmtime

from twintube.common.arrays import Array
from twintube.explorer.module import module


class Module:
    """One instance; arrays are placed in its memory and never released."""

    def __init__(self) -> None:
        engine = wasmtime.Engine()
        self.store = wasmtime.Store(engine)
        self.exports = wasmtime.Instance(self.store, wasmtime.Module(engine, module()), []).exports(self.store)
        self.call("_initialize")

    def call(self, name: str, *arguments: Any) -> Any:
        return self.exports[name](self.store, *arguments)  # type: ignore[operator]

    def view(self, at: int, size: int, kind: type = np.float64) -> Array:
        """Values in the module's memory; valid until the memory grows."""
        memory: Any = self.exports["memory"]
        every = (ctypes.c_ubyte * memory.data_len(self.store)).from_address(
            ctypes.addressof(memory.data_ptr(self.store).contents)
        )
        return np.frombuffer(every, kind, size, at)

    def place(self, values: Any, kind: type = np.float64) -> int:
        array = np.ascontiguousarray(values, dtype=kind)
        at = int(self.call("reserve_memory", array.nbytes))
        self.view(at, array.size, kind)[:] = array.ravel()
        return at

    def unit(self, reals: dict[int, float], integers: dict[int, int]) -> int:
        """A unit with parameters by value reference, ready to start."""
        unit = int(self.call("open_unit"))
        for name, values, kind in (("fmi2SetReal", reals, np.float64), ("fmi2SetInteger", integers, np.int32)):
            references = self.place(list(values), np.uint32)
            assert self.call(name, unit, references, len(values), self.place(list(values.values()), kind)) == 0
        return unit

    def record(self, unit: int, time: Array, stroke: Array, velocity: Array, wanted: list[int]) -> Array:
        """Outputs (wanted, n) of a record from rest at its first sample."""
        n = len(time)
        assert self.call("start_unit", unit, float(time[0]), float(stroke[0])) == 1
        placed = [self.place(values) for values in (time, stroke, velocity)]
        out = self.place(np.zeros(len(wanted) * n))
        done = self.call("run_record", unit, n, *placed, self.place(wanted, np.uint32), len(wanted), out)
        assert done == n, self.said()
        result = self.view(out, len(wanted) * n).reshape(len(wanted), n).copy()
        for at in (*placed, out):
            self.call("release_memory", at)
        self.call("fmi2FreeInstance", unit)
        return result

    def said(self) -> str:
        at = int(self.call("said"))
        return bytes(self.view(at, 512, np.uint8)).split(b"\0")[0].decode()
