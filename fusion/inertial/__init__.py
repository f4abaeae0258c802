"""The inertial arm: from raw inertial sensors to shoulder, elbow, wrist and hand [Liu2017]."""
