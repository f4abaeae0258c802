"""A person who reaches, and sensors that see them badly: for the demonstration and for tests that need the truth."""
