-- Rows that arrive late change what a slot's window holds: the analysis is revised, its former
-- verdict stays. What changed, and when, in one place.

CREATE INDEX verdict_revised ON loopscope.verdict (decided_at) WHERE input_revision > 1;

CREATE VIEW loopscope.revised_verdict AS
  SELECT loop.loop_id, loop.name AS loop_name, revised.slot_end, revised.algorithm_revision,
         revised.input_revision, revised.decided_at AS revised_at, former.decided_at AS former_decided_at,
         former.code AS former_code, revised.code, former.code <> revised.code AS code_changed,
         former.confidence AS former_confidence, revised.confidence,
         former.summary AS former_summary, revised.summary, revised.analysis_id
  FROM loopscope.verdict AS revised
  JOIN loopscope.loop USING (loop_id)
  LEFT JOIN loopscope.verdict AS former
    ON former.loop_id = revised.loop_id AND former.slot_end = revised.slot_end
   AND former.algorithm_revision = revised.algorithm_revision
   AND former.input_revision = revised.input_revision - 1
  WHERE revised.input_revision > 1;
COMMENT ON VIEW loopscope.revised_verdict IS 'One row per revision of a stored analysis, whose input had changed (late rows, other settings, other tags): the verdict beside the former one';
COMMENT ON COLUMN loopscope.revised_verdict.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.revised_verdict.input_revision IS '2 = the first revision of the slot';
COMMENT ON COLUMN loopscope.revised_verdict.revised_at IS 'When the slot was analysed again';
COMMENT ON COLUMN loopscope.revised_verdict.former_decided_at IS 'When the former verdict was given';
COMMENT ON COLUMN loopscope.revised_verdict.former_code IS 'The verdict before the revision';
COMMENT ON COLUMN loopscope.revised_verdict.code_changed IS 'Whether the revision gave another verdict';
COMMENT ON COLUMN loopscope.revised_verdict.former_confidence IS 'Confidence of the former verdict';
COMMENT ON COLUMN loopscope.revised_verdict.former_summary IS 'Summary of the former verdict';
