"""From joint positions to angles, and from the healthy arm to the affected one."""
