"""Everything that runs behind the application, gathered in one value."""

from __future__ import annotations

from dataclasses import dataclass

from db.database import Database
from server.api.auth import Auth
from server.api.demo import Demo
from server.api.therapy import Therapy


@dataclass(frozen=True, slots=True)
class Service:
    """The parts of a running service."""

    database: Database
    auth: Auth
    demo: Demo
    therapy: Therapy
