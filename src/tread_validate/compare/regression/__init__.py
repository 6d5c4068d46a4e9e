"""How peak force depends on speed and temperature: a_v and a_theta of every source."""
