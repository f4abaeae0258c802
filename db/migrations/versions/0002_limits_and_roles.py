"""What an account is for; torque, help and the signature in a patient's limits; how a session's drive began to help."""

import json

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None

ROLES = sa.Enum("admin", "therapist", "screen", name="role", native_enum=False, length=20)
FORCE = {"torque_nm": 15.0, "resistance_nm": 6.0}
FORCE_LIMITS = json.dumps(dict.fromkeys(("plane", "elevation", "rotation", "elbow"), FORCE))


def added() -> dict[str, tuple[sa.Column, ...]]:
    """New columns per table, with what the rows that are there already get."""
    return {
        # Every account could do everything, and nobody had signed for any limits.
        "account": (sa.Column("role", ROLES, nullable=False, server_default="admin"),),
        "patient": (
            sa.Column("force_limits", sa.JSON(), nullable=False, server_default=FORCE_LIMITS),
            sa.Column("assistance", sa.String(), nullable=False, server_default="passive"),
            sa.Column("assist_level_most", sa.Float(), nullable=False, server_default="1.0"),
            sa.Column("limits_set_by", sa.String(length=80), nullable=False, server_default=""),
            sa.Column("limits_set_at", sa.DateTime(timezone=True), nullable=True),
        ),
        "therapy_session": (
            sa.Column("assistance", sa.String(), nullable=False, server_default="passive"),
            sa.Column("assist_level", sa.Float(), nullable=False, server_default="1.0"),
        ),
    }


def upgrade() -> None:
    for table, columns in added().items():
        with op.batch_alter_table(table, schema=None) as batch_op:
            for column in columns:
                batch_op.add_column(column)
        with op.batch_alter_table(table, schema=None) as batch_op:
            for column in columns:
                batch_op.alter_column(column.name, server_default=None)


def downgrade() -> None:
    for table, columns in added().items():
        with op.batch_alter_table(table, schema=None) as batch_op:
            for column in columns:
                batch_op.drop_column(column.name)
