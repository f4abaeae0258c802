"""The steps from an empty database to this program's form."""
