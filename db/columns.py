"""Column types that say what SQL alone would forget: a time's zone, an enumeration's word, a document's shape."""

from __future__ import annotations

from datetime import UTC, datetime
from enum import StrEnum
from typing import Any

from pydantic import TypeAdapter
from sqlalchemy import JSON, DateTime, Dialect, Enum, TypeDecorator


def now_utc() -> datetime:
    """The wall clock, with its zone. Used for the record only; nothing is timed by it."""
    return datetime.now(UTC)


class UtcDateTime(TypeDecorator[datetime]):
    """A time with a zone, kept in UTC; SQLite would drop the zone and hand back a naive time."""

    impl = DateTime(timezone=True)
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """To the database: refuse a time without zone, turn the rest to UTC."""
        if value is None:
            return None
        if value.tzinfo is None:
            raise ValueError(f"a time needs its zone; {value!r} has none")
        return value.astimezone(UTC)

    def process_result_value(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """From the database: give the zone back."""
        if value is None:
            return None
        return value.replace(tzinfo=UTC) if value.tzinfo is None else value.astimezone(UTC)


class Document(TypeDecorator[Any]):
    """A pydantic model, or a tuple of them, kept as JSON."""

    impl = JSON(none_as_null=True)
    cache_ok = True

    def __init__(self, model: Any) -> None:
        super().__init__()
        self.model = model
        self._adapter: TypeAdapter[Any] = TypeAdapter(model)

    def process_bind_param(self, value: Any, dialect: Dialect) -> Any:
        """To the database; plain dictionaries and lists are validated first."""
        return None if value is None else self._adapter.dump_python(self._adapter.validate_python(value), mode="json")

    def process_result_value(self, value: Any, dialect: Dialect) -> Any:
        """From the database."""
        return None if value is None else self._adapter.validate_python(value)


def word_of(kind: type[StrEnum]) -> Enum:
    """An enumeration stored as its word, so that the file is legible and no database needs a type of its own."""
    return Enum(kind, native_enum=False, length=20, values_callable=lambda members: [m.value for m in members])
