"""Plans, scores that people enter, several exercises in a session, its notes and its workspace."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None

# The one game of before had six rounds of a minute.
EXERCISES = (
    "UPDATE therapy_session SET exercises = "
    "json_array(json_object('game', game, 'minutes', 6.0, 'level', level, 'pinned', json('false')))"
)
# What became of it: its last count, and how long the arm was engaged, where that was measured.
PLAYED = """
UPDATE therapy_session SET played = json_array(json_object(
    'game', game,
    'played_s', coalesce((SELECT max(value, 0.0) FROM metric
                          WHERE session_id = therapy_session.id AND name = 'time_engaged'), 0.0),
    'score', coalesce(json_extract(counted.data, '$.score'), 0),
    'hits', coalesce(json_extract(counted.data, '$.hits'), 0),
    'misses', coalesce(json_extract(counted.data, '$.misses'), 0),
    'level', coalesce(json_extract(counted.data, '$.level'), level)
)) FROM event AS counted
WHERE counted.id = (SELECT max(id) FROM event WHERE session_id = therapy_session.id AND kind = 'score')
"""
FIRST_GAME = (
    "UPDATE therapy_session SET game = coalesce(json_extract(exercises, '$[0].game'), 'reach'), "
    "level = coalesce(json_extract(exercises, '$[0].level'), 0.2)"
)


def upgrade() -> None:
    _add_plans()
    _add_scores()
    with op.batch_alter_table("therapy_session", schema=None) as batch_op:
        batch_op.add_column(sa.Column("exercises", sa.JSON(), nullable=False, server_default="[]"))
        batch_op.add_column(sa.Column("played", sa.JSON(), nullable=False, server_default="[]"))
        batch_op.add_column(sa.Column("notes", sa.String(length=10000), nullable=False, server_default=""))
        batch_op.add_column(sa.Column("workspace", sa.JSON(), nullable=True))
    with op.batch_alter_table("metric", schema=None) as batch_op:
        batch_op.add_column(sa.Column("sem", sa.Float(), nullable=True))
    op.execute(EXERCISES)
    op.execute(PLAYED)
    with op.batch_alter_table("therapy_session", schema=None) as batch_op:
        batch_op.drop_column("game")
        batch_op.drop_column("level")
        for name in ("exercises", "played", "notes"):
            batch_op.alter_column(name, server_default=None)


def _add_plans() -> None:
    op.create_table(
        "plan",
        sa.Column("exercises", sa.JSON(), nullable=False),
        sa.Column("repetitions", sa.Integer(), nullable=True),
        sa.Column("sessions_per_week", sa.Integer(), nullable=False),
        sa.Column("weeks", sa.Integer(), nullable=False),
        sa.Column("starts_on", sa.Date(), nullable=False),
        sa.Column("note", sa.String(length=10000), nullable=False),
        sa.Column("patient_id", sa.Integer(), nullable=False),
        sa.Column("updated_by", sa.String(length=80), nullable=False),
        sa.Column("updated_at", sa.DateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(["patient_id"], ["patient.id"]),
        sa.PrimaryKeyConstraint("patient_id"),
    )


def _add_scores() -> None:
    op.create_table(
        "clinical_score",
        sa.Column("kind", sa.String(), nullable=False),
        sa.Column("side", sa.String(), nullable=False),
        sa.Column("value", sa.Integer(), nullable=False),
        sa.Column("on", sa.Date(), nullable=False),
        sa.Column("rater", sa.String(length=80), nullable=False),
        sa.Column("note", sa.String(length=2000), nullable=False),
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("patient_id", sa.Integer(), nullable=False),
        sa.Column("entered_by", sa.String(length=80), nullable=False),
        sa.Column("entered_at", sa.DateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(["patient_id"], ["patient.id"]),
        sa.PrimaryKeyConstraint("id"),
    )
    with op.batch_alter_table("clinical_score", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_clinical_score_patient_id"), ["patient_id"], unique=False)


def downgrade() -> None:
    with op.batch_alter_table("therapy_session", schema=None) as batch_op:
        batch_op.add_column(sa.Column("game", sa.String(length=40), nullable=False, server_default="reach"))
        batch_op.add_column(sa.Column("level", sa.Float(), nullable=False, server_default="0.2"))
    op.execute(FIRST_GAME)
    with op.batch_alter_table("therapy_session", schema=None) as batch_op:
        for name in ("exercises", "played", "notes", "workspace"):
            batch_op.drop_column(name)
        for name in ("game", "level"):
            batch_op.alter_column(name, server_default=None)
    with op.batch_alter_table("metric", schema=None) as batch_op:
        batch_op.drop_column("sem")
    op.drop_table("clinical_score")
    op.drop_table("plan")
