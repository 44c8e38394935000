# From the log of ctest and its LastTest.log: a line for every reason, with the tests that were skipped for it.
FNR == NR { if ($NF == "(Skipped)") skipped[$3] = 1; next }
/^[0-9]+\/[0-9]+ Testing: / { name = $3; why = "" }
behind { why = $0; behind = 0 }
/: Skipped$/ { behind = 1 }
/^skipped: / { why = substr($0, 10) }
/^<end of output>/ && name in skipped {
  if (why == "") why = "it does not say why"
  if (++count[why] <= 3) names[why] = names[why] " " name
}
END {
  for (why in count)
    printf "skipped:%s%s: %s\n", names[why], (count[why] > 3 ? " and " (count[why] - 3) " more" : ""), why
}
