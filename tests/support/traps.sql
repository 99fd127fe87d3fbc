-- Somebody who may make objects in `public` puts functions, operators, tables and types there that stand in for
-- PostgreSQL's. Each of them ends the statement that falls for it, and leaves a mark that no rollback takes away:
-- public.sprung is called then. Run it once in a database, as a role with CREATE on public.
SET search_path = pg_catalog, pg_temp;  -- not into a trap by itself
CREATE SEQUENCE public.sprung;
GRANT ALL ON SEQUENCE public.sprung TO PUBLIC;
CREATE FUNCTION public.trap() RETURNS boolean LANGUAGE plpgsql VOLATILE AS $$
BEGIN
  PERFORM pg_catalog.nextval('public.sprung');
  RAISE EXCEPTION 'a trap was run, as %', current_user;
END $$;
DO $$
DECLARE copied record;
BEGIN
  -- Every function that statements call, with each of its signatures.
  FOR copied IN
    SELECT p.oid, p.proname, p.prokind, pg_get_function_identity_arguments(p.oid) AS arguments,
           pg_get_function_result(p.oid) AS result, p.proargnames
    FROM pg_proc AS p
    WHERE p.pronamespace = 'pg_catalog'::regnamespace AND p.prokind = 'f'
      AND p.proname IN ('now', 'clock_timestamp', 'unnest', 'lower', 'btrim', 'date_trunc',
        'extract', 'make_interval', 'jsonb_array_elements', 'set_config', 'pg_has_role',
        'has_table_privilege', 'has_schema_privilege', 'has_database_privilege', 'to_regclass',
        'pg_advisory_xact_lock', 'current_schemas', 'current_database', 'abs', 'encode',
        'convert_to', 'float8', 'int8', 'text', 'timezone', 'format', 'quote_ident', 'to_char',
        'generate_series', 'array_to_string', 'jsonb_typeof', 'to_regrole')
      AND p.proretset = ANY (ARRAY[false, true])
  LOOP
    BEGIN
      EXECUTE format('CREATE FUNCTION public.%I(%s) RETURNS %s LANGUAGE plpgsql VOLATILE AS %L',
        copied.proname, copied.arguments, copied.result,
        'BEGIN PERFORM public.trap(); END');
    EXCEPTION WHEN OTHERS THEN NULL;  -- what cannot be copied cannot be put in its place
    END;
  END LOOP;
  -- What takes arguments of any type loses against one of just these.
  FOR copied IN
    SELECT f.name, array_to_string(array_fill(t.type, ARRAY[n]), ', ') AS arguments
    FROM unnest('{format,concat,json_build_object,num_nulls,greatest}'::text[]) AS f (name),
         unnest('{text,name,bigint}'::text[]) AS t (type), generate_series(1, 4) AS n
    UNION ALL VALUES ('format', 'text, name'), ('format', 'text, oid'), ('unnest', 'text[]'), ('unnest', 'bigint[]'),
      ('array_length', 'text[], integer'), ('cardinality', 'text[]'), ('array_to_string', 'text[], text'),
      ('json_build_object', 'text, name'),
      ('json_build_object', 'text, text, text, text, text, text, text, float8, text, bigint, text, float8, text, timestamptz,'
        ' text, timestamptz, text, timestamptz, text, text, text, text'),  -- the hook's
      ('to_char', 'timestamptz, text')
  LOOP
    BEGIN
      EXECUTE format('CREATE FUNCTION public.%I(%s) RETURNS text LANGUAGE plpgsql VOLATILE AS %L', copied.name, copied.arguments,
                     'BEGIN PERFORM public.trap(); END');
    EXCEPTION WHEN duplicate_function THEN NULL;  -- copied above
    END;
  END LOOP;
  -- Every comparison and sum of the types in use, and those between types that PostgreSQL has
  -- no operator of its own for: these are taken even when pg_catalog is looked into first.
  FOR copied IN
    SELECT o.op, l.type AS l, r.type AS r
    FROM unnest('{=,<>,<,<=,>,>=,+,-,*,/,||,&,->,->>,~}'::text[]) AS o (op),
         unnest('{text,varchar,name,int2,int4,int8,float4,float8,numeric,timestamptz,timestamp,
                  interval,jsonb,bool,oid,"char"}'::text[]) AS l (type),
         unnest('{text,varchar,name,int2,int4,int8,float4,float8,numeric,timestamptz,timestamp,
                  interval,jsonb,bool,oid,"char"}'::text[]) AS r (type)
  LOOP
    EXECUTE format('CREATE OR REPLACE FUNCTION public.trap_op(%s, %s) RETURNS boolean
                    LANGUAGE plpgsql VOLATILE AS %L', copied.l, copied.r,
                   'BEGIN PERFORM public.trap(); END');
    EXECUTE format('CREATE OPERATOR public.%s (FUNCTION = public.trap_op, LEFTARG = %s,
                    RIGHTARG = %s)', copied.op, copied.l, copied.r);
  END LOOP;
END $$;
CREATE TABLE public.pg_class (x int);
CREATE TABLE public.pg_namespace (x int);
CREATE TABLE public.pg_roles (x int);
CREATE TABLE public.pg_timezone_names (x int);
CREATE TABLE public.pg_inherits (x int);
CREATE TABLE public.pg_settings (x int);
CREATE TABLE public.loop (x int);
CREATE DOMAIN public.timestamptz AS text;
CREATE DOMAIN public.regclass AS text;
CREATE TYPE public.text AS ENUM ('a');
CREATE FUNCTION public.trap_cast(public.text) RETURNS pg_catalog.text LANGUAGE plpgsql VOLATILE AS
  'BEGIN PERFORM public.trap(); END';
CREATE CAST (public.text AS pg_catalog.text) WITH FUNCTION public.trap_cast(public.text) AS IMPLICIT;
CREATE VIEW public.pg_database AS SELECT public.trap();
CREATE VIEW public.pg_db_role_setting AS SELECT public.trap();
CREATE TEMPORARY TABLE pg_settings (x int);
RESET search_path;
