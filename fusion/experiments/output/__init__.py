"""Outcomes as files: pictures, CSV, a page for the browser and one for the documentation."""
