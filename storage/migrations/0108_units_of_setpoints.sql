-- The flag of a setpoint in another unit than pv, and words that name units among the causes where pv stays away from
-- its setpoint.
INSERT INTO loopscope.data_problem_kind (code, role, shown, words, remedy) VALUES
  ('units_differ', 'sp', true, 'The setpoint is recorded in another unit than pv',
   'Record the setpoint in the unit of pv, or convert it in a view that the historian''s table is read through')
ON CONFLICT (code) DO UPDATE SET role = EXCLUDED.role, shown = EXCLUDED.shown, words = EXCLUDED.words,
  remedy = EXCLUDED.remedy;

UPDATE loopscope.data_problem_kind SET
  words = 'pv stays far from the set point: the controller is not in command, the tag is another loop''s, or the units '
          'differ',
  remedy = 'Check that sp and pv belong together and have one unit; disable the loop if something else holds the valve'
WHERE code = 'sp_not_followed';

UPDATE loopscope.data_problem_kind SET remedy = 'Correct the clock or the time zone of the sender'
WHERE code = 'future_rows';
