/* Games of the memory player under a table, written down plainly; the same numbers as kiosk.training plays.

   cc -O2 -shared -fPIC -o games.so games.c. Actions are no help, column, row and card; the player follows every hint,
   never lapses, and forgets the same in every game. */

#include <stdint.h>

enum { COLUMNS = 6, CARDS = 24, PAIRS = 12, NOWHERE = -1, TALLY = 9, LONGEST = 256 };

typedef struct {
    uint64_t random;
    int mate[CARDS], found[CARDS], count[CARDS], last[CARDS], mark[CARDS], recall[CARDS];
    int flips, last_match, pairs, first, matched, help;
} Game;

static uint64_t bits(Game *g) {
    g->random = 2146999758u * (g->random & 0xffffffffu) + (g->random >> 32);
    return (g->random ^ (g->random >> 32)) & 0xffffffffu;
}

static int below(Game *g, int number) { return (int)((bits(g) * (uint64_t)number) >> 32); }

static double unit(Game *g) { return (double)bits(g) * 0x1p-32; }

static void deal(Game *g) {
    for (int place = 0; place < CARDS; place++) {
        g->mark[place] = place;
        g->found[place] = g->count[place] = g->last[place] = g->recall[place] = 0;
    }
    for (int last = CARDS - 1; last > 0; last--) {
        int other = below(g, last + 1), kept = g->mark[last];
        g->mark[last] = g->mark[other];
        g->mark[other] = kept;
    }
    for (int pair = 0; pair < PAIRS; pair++) {
        int one = g->mark[2 * pair], other = g->mark[2 * pair + 1];
        g->mate[one] = other;
        g->mate[other] = one;
    }
    g->flips = g->last_match = g->pairs = g->help = 0;
    g->first = NOWHERE;
    g->matched = 1;
}

static int pick(Game *g, int number) {
    int left = below(g, number);
    for (int place = 0; place < CARDS; place++)
        if (g->mark[place] && left-- == 0) return place;
    return NOWHERE;
}

static int target(Game *g) {
    int most = 0, number = 0;
    if (g->first != NOWHERE) {
        below(g, 1);
        return g->mate[g->first];
    }
    for (int place = 0; place < CARDS; place++)
        if (!g->found[place] && g->count[place] > most) most = g->count[place];
    for (int place = 0; place < CARDS; place++) {
        g->mark[place] = !g->found[place] && (most == 0 || g->count[g->mate[place]] == most);
        number += g->mark[place];
    }
    return pick(g, number);
}

static int in_line(int action, int target, int place) {
    if (action == 0) return 1;
    return action == 1 ? place % COLUMNS == target % COLUMNS : place / COLUMNS == target / COLUMNS;
}

static int mark_line(Game *g, int action, int target, int ruled_out) {
    int number = 0;
    for (int place = 0; place < CARDS; place++) {
        g->mark[place] = in_line(action, target, place) && !g->found[place] && place != g->first
            && g->recall[place] < ruled_out;
        number += g->mark[place];
    }
    return number;
}

static int choose(Game *g, const double *kept, int action, int target) {
    if (g->first == NOWHERE)
        for (int place = 0; place < CARDS; place++) {
            g->recall[place] = 0;
            if (!g->found[place] && g->last[place] > 0) {
                int age = g->flips - g->last[place];
                g->recall[place] = unit(g) < kept[age < LONGEST ? age : LONGEST - 1];
            }
        }
    if (action == 3) return target;
    for (int place = 0; place < CARDS; place++) {
        int mate = g->mate[place];
        if (g->recall[place] && (mate == g->first || (g->first == NOWHERE && g->recall[mate]))
            && in_line(action, target, place))
            return place;
    }
    int number = mark_line(g, action, target, 1);
    return pick(g, number > 0 || action == 0 ? number : mark_line(g, action, target, 2));
}

static int flip(Game *g, int place) {
    g->flips++;
    g->count[place]++;
    g->last[place] = g->flips;
    int first = g->first;
    if (first == NOWHERE) {
        g->first = place;
        return 0;
    }
    g->first = NOWHERE;
    g->matched = g->mate[first] == place;
    if (g->matched) {
        g->found[first] = g->found[place] = 1;
        g->pairs++;
        g->last_match = g->flips;
    }
    return g->matched;
}

/* gate: opening, patience, patience before the first pair; q: 4 values for each of 48 states; tallies: 9 for a game. */
void play(uint64_t random, const int64_t *gate, const double *q, double forgetting, int64_t games, int64_t *tallies) {
    Game game = {.random = random}, *g = &game;
    double kept[LONGEST];
    kept[0] = 1.0;
    for (int age = 1; age < LONGEST; age++) kept[age] = kept[age - 1] * (1.0 - forgetting);
    for (int64_t *tally = tallies; tally < tallies + games * TALLY; tally += TALLY) {
        int led = 0;
        for (int entry = 0; entry < TALLY; entry++) tally[entry] = 0;
        deal(g);
        while (g->pairs < PAIRS && g->flips < 5000) {
            int second = g->first != NOWHERE, action = 0;
            int needed = (int)(g->pairs == 0 ? gate[2] : gate[1]);
            if (g->flips >= gate[0] && (second || g->flips - g->last_match >= needed)) {
                int phase = g->pairs * 3 / PAIRS;
                int outcome = (g->matched ? 0 : 1) + (second ? 2 : 0);
                const double *row = q + ((phase < 3 ? phase : 2) * 4 + g->help) * 16 + outcome * 4;
                for (int each = 1; each < 4; each++)
                    if (row[each] > row[action]) action = each;
            }
            int aim = action ? target(g) : NOWHERE, followed = (int)tally[6];
            int place = choose(g, kept, action, aim);
            g->help = action;
            tally[0]++;
            if (action) {
                tally[second ? 2 : 1]++;
                tally[2 + action]++;
                if (action == 3 ? place == aim : in_line(action, aim, place)) tally[second ? 7 : 6]++;
            }
            int matched = flip(g, place);
            if (g->first != NOWHERE) led = tally[6] > followed;
            else if (led) tally[8] += matched;
        }
    }
}
