# Of the lines, the one with the fewest letters to change from the word `a`, if there are few.
function least(x, y) { return x < y ? x : y }
function distance(b,  i, j, cost, d) {
  for (i = 0; i <= length(a); i++) d[i, 0] = i
  for (j = 0; j <= length(b); j++) d[0, j] = j
  for (i = 1; i <= length(a); i++)
    for (j = 1; j <= length(b); j++) {
      cost = substr(a, i, 1) == substr(b, j, 1) ? 0 : 1
      d[i, j] = least(least(d[i - 1, j], d[i, j - 1]) + 1, d[i - 1, j - 1] + cost)
    }
  return d[length(a), length(b)]
}
BEGIN { best = 4 }
{ n = distance($0); if (n < best) { best = n; word = $0 } }
END { print word }
