"""An exoskeleton of CANopen CiA 402 drives, one per joint, in cyclic synchronous position mode (docs/cia402.md)."""

from server.station.exo.cia402.drive import Cia402Drive

__all__ = ["Cia402Drive"]
