"""What the service asks of the database: a file per table, functions that take a session and return rows."""
