# shellcheck shell=bash
# What the demo shows at its end. Source this file after demo_databases.sh.
#
#   demo_show_flags FOLDER        the ranked loops of the view flagged_loop
#   demo_show_verdicts FOLDER     how often each verdict was given
#   demo_show_truth FOLDER        what was simulated beside what was found
#   demo_show_rows FOLDER         rows in the results
#   demo_show_next_steps FOLDER PROGRAM SCRIPT   commands to paste

_as_reader() {
  printf '%s\n' "$2"
  demo_psql "$1" demo_reader loopscope --pset footer=off
}

demo_show_flags() {
  _as_reader "$1" "Flagged loops, worst first (view loopscope.flagged_loop):" <<'SQL'
SELECT rank, loop_name AS loop, code AS verdict, round(score::numeric, 3) AS score,
       round(confidence::numeric, 2) AS confidence,
       round(ngi::numeric, 4) AS ngi, round(nli::numeric, 4) AS nli,
       round(oscillation_period_s::numeric) AS period_s,
       round(harris_low::numeric, 2) || ' to ' || round(harris_high::numeric, 2) AS harris
FROM loopscope.flagged_loop ORDER BY rank;
SQL
}

demo_show_verdicts() {
  _as_reader "$1" "Verdicts (view loopscope.latest_verdict):" <<'SQL'
SELECT latest.code AS verdict, count(*) AS loops, count(flagged.loop_id) AS flagged
FROM loopscope.latest_verdict AS latest LEFT JOIN loopscope.flagged_loop AS flagged USING (loop_id)
GROUP BY latest.code ORDER BY loops DESC, verdict;
SQL
}

# loop,scenario,... of demo_loops.csv as rows of a VALUES list; its words are plain.
_simulated_as() {
  awk -F, "NR > 1 { printf \"%s('%s', '%s')\", (NR > 2 ? \", \" : \"\"), \$1, \$2 }" "$_DEMO_LOOPS_CSV"
}

demo_show_truth() {
  _as_reader "$1" "What was simulated, and what was found:" <<SQL
SELECT simulated.scenario AS simulated, count(*) AS loops, string_agg(DISTINCT latest.code, ', ') AS found
FROM (VALUES $(_simulated_as)) AS simulated (loop_name, scenario)
JOIN loopscope.latest_verdict AS latest USING (loop_name)
GROUP BY simulated.scenario ORDER BY simulated.scenario;
SQL
}

demo_show_rows() {
  demo_sql "$1" demo_reader loopscope "SELECT format('%s loops, %s analysis rows, %s verdict rows, %s with a verdict other than insufficient_data',
    (SELECT count(*) FROM loopscope.loop), (SELECT count(*) FROM loopscope.analysis), (SELECT count(*) FROM loopscope.verdict),
    (SELECT count(*) FROM loopscope.latest_verdict WHERE code <> 'insufficient_data'))"
}

demo_show_next_steps() {
  local reader config=$1/loopscope.json
  reader=$(demo_conninfo "$1" demo_reader loopscope)
  cat <<EOT
Ask for more:
  psql "$reader" -c "SELECT loop_name, summary, action FROM loopscope.flagged_loop"
  psql "$reader" -c "SELECT * FROM loopscope.loop_history LIMIT 5" -x
  psql "$reader" -c "\\dv+ loopscope.*"
  $2 loops --config $config
The report of the flagged loops, with pictures:
  $2 report --config $config --out $1/reports --pdf
Another pass, which finds nothing new until the historian does:
  $2 once --config $config
Let it run as a daemon (Ctrl-C ends it); pages at http://127.0.0.1:9470/:
  $2 run --config $config
Stop the server and keep everything; the same command as before starts it again:
  $3 --stop$4
Stop the server and remove everything the demo made (packages and build/ stay):
  $3 --remove$4
EOT
}
