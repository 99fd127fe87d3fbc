-- Months of results: made ahead, dropped when they are old. A row whose month has no partition goes
-- into DEFAULT and is moved when its month is made, so that no result is ever refused.

CREATE FUNCTION loopscope.partitioned_tables() RETURNS text[] IMMUTABLE LANGUAGE sql
RETURN ARRAY['analysis', 'bicoherence_peak', 'explanation_step', 'verdict'];
COMMENT ON FUNCTION loopscope.partitioned_tables() IS 'The tables that are partitioned by month of slot_end';

-- LIKE and ATTACH instead of PARTITION OF: comments come along, and the parent stays open for
-- writers (ATTACH locks it SHARE UPDATE EXCLUSIVE, PARTITION OF would lock it ACCESS EXCLUSIVE).
CREATE FUNCTION loopscope.new_partition_table(parent text, partition text, described text)
RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  EXECUTE format('CREATE TABLE loopscope.%I (LIKE loopscope.%I INCLUDING ALL)', partition, parent);
  EXECUTE format('COMMENT ON TABLE loopscope.%I IS %L', partition, described);
END $$;
COMMENT ON FUNCTION loopscope.new_partition_table(text, text, text) IS 'An empty table that can become a partition of parent';

DO $$
DECLARE parent text;
BEGIN
  FOREACH parent IN ARRAY loopscope.partitioned_tables() LOOP
    PERFORM loopscope.new_partition_table(parent, parent || '_default',
      format('Rows of %s whose month has no partition', parent));
    EXECUTE format('ALTER TABLE loopscope.%I ATTACH PARTITION loopscope.%I DEFAULT', parent, parent || '_default');
  END LOOP;
END $$;

CREATE FUNCTION loopscope.make_partition(parent text, month timestamptz) RETURNS text LANGUAGE plpgsql
SET search_path = pg_catalog SET timezone = 'UTC' AS $$
DECLARE
  from_time timestamptz := date_trunc('month', month);
  to_time   timestamptz := date_trunc('month', month) + interval '1 month';
  partition text := parent || to_char(month, '_YYYY_MM');
BEGIN
  IF to_regclass(format('loopscope.%I', partition)) IS NOT NULL THEN
    RETURN NULL;
  END IF;
  PERFORM loopscope.new_partition_table(parent, partition,
    format('Rows of %s with slot_end in %s', parent, to_char(month, 'YYYY-MM')));
  -- Before the attachment: PostgreSQL refuses it while DEFAULT holds rows of the month. The lock
  -- keeps a worker from adding one in between.
  EXECUTE format('LOCK TABLE loopscope.%I IN ACCESS EXCLUSIVE MODE', parent || '_default');
  EXECUTE format('WITH moved AS (DELETE FROM loopscope.%I WHERE slot_end >= %L AND slot_end < %L RETURNING *)
                  INSERT INTO loopscope.%I SELECT * FROM moved',
                 parent || '_default', from_time, to_time, partition);
  EXECUTE format('ALTER TABLE loopscope.%I ATTACH PARTITION loopscope.%I FOR VALUES FROM (%L) TO (%L)',
                 parent, partition, from_time, to_time);
  RETURN partition;
END $$;
COMMENT ON FUNCTION loopscope.make_partition(text, timestamptz) IS 'Makes the partition of parent for the month (UTC) and moves its rows out of DEFAULT; returns its name, null when it exists';

CREATE FUNCTION loopscope.make_partitions(first_month timestamptz, months integer)
RETURNS SETOF text LANGUAGE sql SET search_path = pg_catalog SET timezone = 'UTC' AS $$
  SELECT made.name
  FROM generate_series(0, months - 1) AS ahead(n)
  CROSS JOIN unnest(loopscope.partitioned_tables()) AS parent(name)
  CROSS JOIN LATERAL loopscope.make_partition(
    parent.name, date_trunc('month', first_month) + make_interval(months => ahead.n)) AS made(name)
  WHERE made.name IS NOT NULL
$$;
COMMENT ON FUNCTION loopscope.make_partitions(timestamptz, integer) IS 'Makes the partitions of so many months from first_month on; returns the names of the new ones';

CREATE FUNCTION loopscope.expired_partitions(before timestamptz) RETURNS SETOF text LANGUAGE sql STABLE
SET search_path = pg_catalog AS $$
  SELECT child.relname::text
  FROM pg_inherits AS inherits
  JOIN pg_class AS child ON child.oid = inherits.inhrelid
  JOIN pg_class AS parent ON parent.oid = inherits.inhparent
  JOIN pg_namespace AS namespace ON namespace.oid = parent.relnamespace
  WHERE namespace.nspname = 'loopscope'
    AND parent.relname = ANY (loopscope.partitioned_tables())
    AND substring(pg_get_expr(child.relpartbound, child.oid) FROM $re$ TO \('([^']+)'\)$re$)::timestamptz <= before
  ORDER BY parent.relname = 'analysis', child.relname
$$;
COMMENT ON FUNCTION loopscope.expired_partitions(timestamptz) IS 'Monthly partitions that end not after `before`; those of analysis last, so that no verdict ever lacks its analysis';

-- Not DETACH CONCURRENTLY, which PostgreSQL refuses beside a DEFAULT partition: the parent is locked
-- for the moment of the drop, so each one is dropped in a transaction of its own.
CREATE FUNCTION loopscope.drop_partition(name text) RETURNS void LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  EXECUTE format('DROP TABLE loopscope.%I', name);
END $$;
COMMENT ON FUNCTION loopscope.drop_partition(text) IS 'Drops one of expired_partitions() with its rows';

CREATE FUNCTION loopscope.delete_old_rows(before timestamptz) RETURNS void LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
DECLARE parent text;
BEGIN
  FOREACH parent IN ARRAY loopscope.partitioned_tables() LOOP
    EXECUTE format('DELETE FROM loopscope.%I WHERE slot_end < %L', parent || '_default', before);
  END LOOP;
  DELETE FROM loopscope.plant_oscillation WHERE slot_end < before;
END $$;
COMMENT ON FUNCTION loopscope.delete_old_rows(timestamptz) IS 'Deletes results older than `before` that lie in no monthly partition';
