"""The demonstration: an account without a password, and its patient."""

from __future__ import annotations

from ipaddress import ip_address

from db.account import Account
from db.database import Database
from db.patient import Patient, PatientCreate
from db.queries import accounts, patients
from server.api.auth import Auth
from server.api.errors import ApiError

ACCOUNT_NAME = "demo"
PATIENT = PatientCreate(
    name="Ming (demo)", healthy_side="right", notes="A virtual patient in front of two virtual sensors."
)


class Demo:
    """Lets people in without a password: only with `--demo`, from this machine, with a simulated drive."""

    def __init__(self, database: Database, auth: Auth, offered: bool) -> None:
        self._database, self._auth, self._offered = database, auth, offered

    def is_open_to(self, client: str) -> bool:
        """Whether somebody at that address may enter."""
        return self._offered and _is_loopback(client)

    def enter(self, client: str) -> tuple[Account, Patient, str]:
        """The demonstration's account, its patient and a new token.

        Raises:
            ApiError: 403 where there is no demonstration, or not for that address.
        """
        if not self.is_open_to(client):
            raise ApiError(
                403,
                "the demonstration is not open from here",
                "'mirrorlimb serve --demo', a simulated drive, and a browser on the same machine",
                "log in with an account",
            )
        with self._database.session() as session:
            account = accounts.find_account(session, ACCOUNT_NAME) or accounts.add_account(session, ACCOUNT_NAME, None)
            known = patients.list_patients(session)
            patient = known[0] if known else patients.add_patient(session, PATIENT, account.id or 0)
            if not patient.limits_set_by:  # the drive is simulated: there is nobody to answer for
                patients.sign_limits(session, patient, ACCOUNT_NAME)
        return account, patient, self._auth.open_login(account)


def _is_loopback(client: str) -> bool:
    try:
        return ip_address(client).is_loopback
    except ValueError:
        return False
