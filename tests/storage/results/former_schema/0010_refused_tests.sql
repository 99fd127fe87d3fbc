-- What the monitor has learnt to see in the data since.

INSERT INTO loopscope.data_problem_kind (code, role, shown, words, remedy) VALUES
  ('unknown_quality', NULL, true, 'Rows have a quality code that the settings do not know; they count as bad', 'Add the code to good_codes or bad_codes of the historian, or correct quality_rule'),
  ('rows_too_dense', NULL, true, 'The window was cut off: the tag has more than two rows a sample', 'Correct interval_s of the loop, or stop the writer from sending rows again'),
  ('tests_refused', 'pv', true, 'Too little of pv was stored, or too little of it is steady, for some tests', 'Lower exception and compression deviation of the tag, or scan it faster'),
  ('pv_compressed', 'pv', true, 'The archive stored only part of pv (exception reporting, dead band or swinging door)', 'Lower exception and compression deviation of the tag'),
  ('samples_drawn', 'pv', false, 'What the archive did not store was drawn for the tests', ''),
  ('pv_frozen_masked', 'pv', true, 'pv stands still for a while as if frozen; that stretch was left out', 'Check transmitter, interface and archive'),
  ('not_stationary', 'pv', true, 'The loop changed within the window; the tests see its longest steady stretch only', 'Note what was changed; analyse the time before and after apart');
