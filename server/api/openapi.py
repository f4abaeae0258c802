"""Writes the interface's description to a file: `python -m server.api.openapi FILE`.

The stream's messages are merged in, so that the browser's types come from one document.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import msgspec
from fastapi import FastAPI

from server.api.app import describe_app
from server.api.live import Acknowledgement, LiveMessage

_REF = "#/components/schemas/{name}"


def openapi_document(app: FastAPI) -> dict[str, Any]:
    """The application's OpenAPI description, with the stream's schemas among its components."""
    document = app.openapi()
    _, stream_schemas = msgspec.json.schema_components((LiveMessage, Acknowledgement), ref_template=_REF)
    schemas = document["components"]["schemas"]
    schemas |= {name: schema for name, schema in stream_schemas.items() if name not in schemas}
    return document


def main() -> None:
    """Write the description to the file named on the command line."""
    text = json.dumps(openapi_document(describe_app()), indent=2, sort_keys=True, ensure_ascii=False)
    Path(sys.argv[1]).write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
