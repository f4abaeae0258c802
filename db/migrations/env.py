"""Alembic's entry: runs the steps on the connection that `db.migrate` opened."""

from __future__ import annotations

from alembic import context

from db.tables import METADATA

# Batch mode: SQLite cannot alter a column, so a changed table is made anew and copied.
context.configure(connection=context.config.attributes["connection"], target_metadata=METADATA, render_as_batch=True)
with context.begin_transaction():
    context.run_migrations()
