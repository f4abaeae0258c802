"""All tables, gathered so that migrations and tests see the whole."""

from __future__ import annotations

from sqlmodel import SQLModel

from db import account, clinical_score, patient, plan, therapy_session

TABLES = (
    account.Account,
    account.LoginSession,
    patient.Patient,
    plan.TherapyPlan,
    clinical_score.ClinicalScore,
    therapy_session.TherapySession,
    therapy_session.Metric,
    therapy_session.Event,
)

METADATA = SQLModel.metadata
"""What the migrations must lead to."""
